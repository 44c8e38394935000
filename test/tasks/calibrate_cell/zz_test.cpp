#include <gtest/gtest.h>
#include <cstdio>
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/cell/view_plan.hpp"
#include "tasks/calibrate_cell/cell/believed_arm.hpp"
using namespace mrroc; using namespace mrroc::calibrate_cell;
TEST(ZZ,Gravity){ Config c=Config::parse(config(),"x"); BelievedArm a=read_arm(c,1);
 for (auto q0 : {std::vector<double>{1.0, 0.59, -1.0, -0.38, -0.27, 1.15, -3.31},{1.0, 0.84, -1.07, -0.27, 0.07, 1.45, -3.04},{1.0, 0.64, -1.49, 0.24, -0.04, 1.13, -3.79},{0,1.05,-1.13,-.02,1.15,1.05,-1.57},{0.0, 1.601556, -1.485839, 0.335303, 1.150536, 1.601556, -1.570796}}){
  AxisVector q=Eigen::Map<const Eigen::VectorXd>(q0.data(),7); AxisVector t=a.robot->gravity(a.robot->motors_from_joints(q));
  for(int k=0;k<7;++k){auto&d=a.robot->axis(k).servo.drive; std::printf("%.2f ",t[k]/d.torque_constant/d.max_current);} std::printf("\n"); }
 for (std::size_t n:{20UL,200UL}) { auto p=plan_views(c,1,n); std::printf("show %zu present %zu track %.2f\n",p[0].joints.size(),p[1].joints.size(),p[1].joints[0][0]); auto p1=plan_views(c,0,n); std::printf("look %zu\n",p1[0].joints.size());}
}
